/* serial_speed.c - see serial_speed.h. A separate file, because the kernel's header
 * conflicts with the C library's. */
#include "serial_speed.h"

#include <asm/termbits.h>
#include <sys/ioctl.h>

bool serial_speed_set(int file, unsigned int bits_per_second)
{
    struct termios2 t;
    if (ioctl(file, TCGETS2, &t) != 0)
        return false;
    t.c_cflag &= ~(unsigned int)CBAUD;
    t.c_cflag |= BOTHER;
    t.c_ispeed = t.c_ospeed = bits_per_second;
    return ioctl(file, TCSETS2, &t) == 0;
}
