/* fill.h - elements that are all the same, as a loop of whatever instruction set the including
 * file is compiled for. */
#ifndef LUTETIA_MACHINE_FILL_H
#define LUTETIA_MACHINE_FILL_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define FILL_BY(T)                                                                             \
    {                                                                                          \
        T x, *d = to;                                                                          \
        memcpy(&x, element, sizeof x);                                                         \
        for (size_t i = 0; i < count; i++)                                                     \
            d[i] = x;                                                                          \
        break;                                                                                 \
    }

/* So many elements, each these 1, 2, 4, 8 or 16 bytes. */
static inline void fill_elements(void *to, const void *element, size_t bytes, size_t count)
{
    switch (bytes) {
    case 1:
        FILL_BY(uint8_t)
    case 2:
        FILL_BY(uint16_t)
    case 4:
        FILL_BY(uint32_t)
    case 8:
        FILL_BY(uint64_t)
    default:
        FILL_BY(unsigned __int128)
    }
}

#undef FILL_BY

#endif
