/* A second library with a function of Zoltan's. */
int Zoltan_LB_Box_Assign(void) {
    return -1;
}
