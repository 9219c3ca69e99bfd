/* Preloaded into a program, makes its arithmetic round as CORFEM_ROUNDING says: "zero", "down", or to nearest. Threads inherit it. */
#include <fenv.h>
#include <stdlib.h>
#include <string.h>

__attribute__((constructor)) static void round_otherwise(void)
{
    const char *way = getenv("CORFEM_ROUNDING");
    if (way && strcmp(way, "zero") == 0)
        fesetround(FE_TOWARDZERO);
    if (way && strcmp(way, "down") == 0)
        fesetround(FE_DOWNWARD);
}
