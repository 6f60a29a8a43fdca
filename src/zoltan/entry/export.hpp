#pragma once

#ifdef RRCB_ZOLTAN_STATIC
#include <rrcb/zoltan/rrcb_zoltan_rename.h>
#endif

/// Marks the only symbols the plug-in shows: Zoltan's interposed functions and its own two.
#define RRCB_EXPORT extern "C" __attribute__((visibility("default")))
