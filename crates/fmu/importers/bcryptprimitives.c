/* What older versions of Wine lack of Windows: the one function of bcryptprimitives.dll that Rust's library calls. */
#include <stddef.h>

int SystemFunction036(void *data, unsigned long length);

__declspec(dllexport) int ProcessPrng(unsigned char *data, size_t length) {
    return SystemFunction036(data, (unsigned long)length);
}
