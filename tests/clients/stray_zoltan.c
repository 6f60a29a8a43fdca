/* A second library with a function of Zoltan's. */
int Zoltan_Serialize(void) {
    return -1;
}
