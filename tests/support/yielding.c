// Loaded before MPICH over UCX, whose ranks spin while they wait: with more ranks than cores, one
// that has nothing to receive leaves its core to the others.
#include <dlfcn.h>
#include <sched.h>

unsigned ucp_worker_progress(void* worker) {
    static unsigned (*progress)(void*);
    if (!progress) *(void**)&progress = dlsym(RTLD_NEXT, "ucp_worker_progress");
    const unsigned num_events = progress(worker);
    if (num_events == 0) sched_yield();
    return num_events;
}
