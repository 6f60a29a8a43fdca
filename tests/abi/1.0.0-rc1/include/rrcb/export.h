#ifndef RRCB_EXPORT_H
#define RRCB_EXPORT_H

/* Part of the interface: exported by a shared library. */
#if defined(__GNUC__)
#define RRCB_API __attribute__((visibility("default")))
#else
#define RRCB_API
#endif

#endif
