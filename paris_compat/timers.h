/* timers.h - timers that run keep their numbers from one machine to the next. */
#ifndef PARIS_TIMERS_H
#define PARIS_TIMERS_H

/* Before the machine is destroyed; after another was made. */
void paris_timers_machine_goes(void);
void paris_timers_machine_comes(void);

#endif
