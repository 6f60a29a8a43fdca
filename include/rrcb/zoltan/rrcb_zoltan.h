#ifndef RRCB_ZOLTAN_H
#define RRCB_ZOLTAN_H

/** @file
 * Queries of the plug-in itself. */

#ifdef __cplusplus
extern "C" {
#endif

/** Returns 1 if the plug-in is in front of Zoltan in this process, 0 if its functions are shadowed
 *  because it was linked behind Zoltan. Not collective. */
int RRCB_Zoltan_Active(void);

/** Returns the version of the library, as "major.minor.patch". Not collective; the string is
 * static. */
const char* RRCB_Version(void);

/** Returns the names of the parameters that the plug-in adds to Zoltan's, ended by NULL. Not
 * collective; the array is static. */
const char* const* RRCB_Parameter_Names(void);

#ifdef __cplusplus
}
#endif

#endif
