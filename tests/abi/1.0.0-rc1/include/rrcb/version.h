#ifndef RRCB_VERSION_H
#define RRCB_VERSION_H

/* Version of the headers. rrcb_version() returns the version of the library, which may differ if
 * the library is shared. */
#define RRCB_VERSION_MAJOR 1
#define RRCB_VERSION_MINOR 0
#define RRCB_VERSION_PATCH 0
#define RRCB_VERSION_STRING "1.0.0-rc1"

/* Is 1 if the headers have this version or a later one. The preprocessor can evaluate it. */
#define RRCB_VERSION_GE(major, minor, patch)                                  \
    (RRCB_VERSION_MAJOR > (major) ||                                          \
     (RRCB_VERSION_MAJOR == (major) &&                                        \
      (RRCB_VERSION_MINOR > (minor) ||                                        \
       (RRCB_VERSION_MINOR == (minor) && RRCB_VERSION_PATCH >= (patch)))))

#endif
