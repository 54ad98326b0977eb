/* Runs an FMU's library of FMI 3.0 for some communication steps and prints the bits of all variables.
   `library, token, folder of resources, steps, step => bits`; the same program on Linux and on Windows. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#define OPEN(file) (void *)LoadLibraryA(file)
#define FIND(library, name) (void *)GetProcAddress((HMODULE)library, name)
#else
#include <dlfcn.h>
#define OPEN(file) dlopen(file, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif

typedef void (*Log)(void *, int, const char *, const char *);
typedef void *(*Instantiate)(const char *, const char *, const char *, _Bool, _Bool, _Bool, _Bool,
                             const uint32_t *, size_t, void *, Log, void *);
typedef int (*Enter)(void *, _Bool, double, double, _Bool, double);
typedef int (*Plain)(void *);
typedef int (*Step)(void *, double, double, _Bool, _Bool *, _Bool *, _Bool *, double *);
typedef int (*Get)(void *, const uint32_t *, size_t, double *, size_t);

static void show(void *environment, int status, const char *category, const char *message) {
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", status, category, message);
}

int main(int count, char **words) {
    if (count != 7) {
        fprintf(stderr, "LIBRARY TOKEN RESOURCES VARIABLES STEPS STEP\n");
        return 2;
    }
    void *library = OPEN(words[1]);
    if (!library) {
        fprintf(stderr, "%s cannot be loaded\n", words[1]);
        return 1;
    }
    size_t variables = strtoul(words[4], 0, 10);
    unsigned long steps = strtoul(words[5], 0, 10);
    double size = strtod(words[6], 0);
    Instantiate instantiate = (Instantiate)FIND(library, "fmi3InstantiateCoSimulation");
    Step step = (Step)FIND(library, "fmi3DoStep");
    Get get = (Get)FIND(library, "fmi3GetFloat64");
    void *instance = instantiate("one", words[2], words[3], 0, 1, 0, 0, 0, 0, 0, show, 0);
    if (!instance) return 1;
    int status = ((Enter)FIND(library, "fmi3EnterInitializationMode"))(instance, 0, 0.0, 0.0, 0, 0.0);
    status |= ((Plain)FIND(library, "fmi3ExitInitializationMode"))(instance);
    uint32_t *references = malloc(variables * sizeof *references);
    double *values = malloc(variables * sizeof *values);
    for (size_t i = 0; i < variables; i++) references[i] = (uint32_t)i;
    for (unsigned long i = 0; i < steps; i++) {
        _Bool event, end, early;
        double last;
        status |= step(instance, (double)i * size, size, 1, &event, &end, &early, &last);
        status |= get(instance, references, variables, values, variables);
        for (size_t j = 0; j < variables; j++) {
            uint64_t bits;
            memcpy(&bits, &values[j], sizeof bits);
            printf("%016llx%c", (unsigned long long)bits, j + 1 < variables ? ' ' : '\n');
        }
    }
    ((void (*)(void *))FIND(library, "fmi3FreeInstance"))(instance);
    return status != 0;
}
