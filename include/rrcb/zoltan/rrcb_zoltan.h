#ifndef RRCB_ZOLTAN_H
#define RRCB_ZOLTAN_H

/** @file
 * What the plug-in tells of itself. */

#ifdef __cplusplus
extern "C" {
#endif

/** Returns 1 when the plug-in stands in front of Zoltan in this process, 0 when its functions are
 *  shadowed because it was linked behind Zoltan. Not collective. */
int RRCB_Zoltan_Active(void);

/** Version of the library, as "major.minor.patch". Not collective; the string is static. */
const char* RRCB_Version(void);

/** Names of the parameters that the plug-in adds to Zoltan's, ended by NULL. Not collective; the
 *  array is static. */
const char* const* RRCB_Parameter_Names(void);

#ifdef __cplusplus
}
#endif

#endif
