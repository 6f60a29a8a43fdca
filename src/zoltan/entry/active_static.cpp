#include <rrcb/zoltan/rrcb_zoltan.h>

extern "C" {

// Files without the renaming header call this function. Their calls of Zoltan bypass the plug-in.
int RRCB_Zoltan_Active(void) {
    return 0;
}

int RRCB_Zoltan_Renamed_Active(void) {
    return 1;
}

}  // extern "C"
