/* Zoltan as a static archive, for a machine that has only the shared library: every function counts
 * its calls and hands them on to a private copy of that. With WIDE_IDS, and as a shared library, it
 * says that its ids have 64 bits; then only functions that see no id may be called. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void Function(void);

static Function* find(const char* name) {
    void* library = dlopen(ZOLTAN_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    Function* function = library == NULL ? NULL : (Function*)dlsym(library, name);
    if (function != NULL) return function;
    fprintf(stderr, "%s: %s\n", name, dlerror());
    abort();
}

struct Entry {
    const char* name;
    Function* function;
    int num_calls;
};

static Function* count_call(struct Entry* entry) {
    ++entry->num_calls;
    if (entry->function == NULL) entry->function = find(entry->name);
    return entry->function;
}

/* More than the arguments of any function of Zoltan take on the stack. */
#define STACK_BYTES 256

#define FORWARD(name)                                                                            \
    static struct Entry entry_of_##name = {#name, NULL, 0};                                      \
    void* name(void) {                                                                           \
        void* arguments = __builtin_apply_args();                                                \
        __builtin_return(__builtin_apply(count_call(&entry_of_##name), arguments, STACK_BYTES)); \
    }
#include "zoltan_functions.h"
#undef FORWARD

#define FORWARD(name) &entry_of_##name,
static struct Entry* const entries[] = {
#include "zoltan_functions.h"
};

#ifdef WIDE_IDS
int Zoltan_get_global_id_type(char** name) {
    if (name != NULL) *name = (char*)"unsigned long";
    return 8;
}
#endif

int zoltan_archive_calls(const char* name) {
    for (size_t i = 0; i < sizeof entries / sizeof *entries; ++i)
        if (strcmp(entries[i]->name, name) == 0) return entries[i]->num_calls;
    return -1;
}
