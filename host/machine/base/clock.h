/* clock.h - the time now. */
#ifndef LUTETIA_MACHINE_CLOCK_H
#define LUTETIA_MACHINE_CLOCK_H

double clock_s(void);

#endif
