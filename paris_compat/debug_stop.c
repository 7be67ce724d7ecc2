/* debug_stop.c - where a debugger stops. */
#include <stdio.h>

#include "debug.h"

char CM_debug_text[1600];
unsigned int CM_debug_locked;

__attribute__((noinline)) void CM_debug_stop(void)
{
    __asm__ volatile("" ::: "memory");
}

void paris_debug_tell(const char *text)
{
    snprintf(CM_debug_text, sizeof CM_debug_text, "%s", text);
    CM_debug_stop();
}
