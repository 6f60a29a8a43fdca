#ifndef RRCB_ZOLTAN_H
#define RRCB_ZOLTAN_H

/** @file
 * Queries of the plug-in itself. */

#ifdef __cplusplus
extern "C" {
#endif

/** Returns 1 if the plug-in is in front of Zoltan in this process. Returns 0 if the functions of
 * Zoltan are found first, because the plug-in was linked after Zoltan. Not collective. */
int RRCB_Zoltan_Active(void);

/** Returns the version of the library, as "major.minor.patch". Not collective. The string is
 * static. */
const char* RRCB_Version(void);

/** Returns the names of the parameters that the plug-in adds to Zoltan's. The array ends with
 * NULL. Not collective. The array is static. */
const char* const* RRCB_Parameter_Names(void);

#ifdef __cplusplus
}
#endif

#endif
