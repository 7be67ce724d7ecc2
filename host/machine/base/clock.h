/* clock.h - what time it is. */
#ifndef LUTETIA_MACHINE_CLOCK_H
#define LUTETIA_MACHINE_CLOCK_H

double clock_s(void);

#endif
