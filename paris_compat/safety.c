/* safety.c - the modes of checking calls.
 *
 *     at a program's start    errors are reported
 *     CM_set_safety_mode (1)  every argument is also checked before the machine is called
 *     CM_set_safety_mode (0)  lenient, as LUTETIA_LENIENT=1: what the real machine accepted is accepted,
 *                             and reported once
 *
 * In every mode, nothing outside the machine's own memory is read or written.
 */
#include <stdarg.h>
#include <stdio.h>

#include "call_line.h"
#include "paris_state.h"
#include "visible_text.h"

static enum { USUAL, LENIENT, SAFE } mode;

static void mode_set(unsigned int which)
{
    mode = which;
    paris_the.safety = mode == SAFE;
    if (paris_the.machine) {
        machine_calls_forget(paris_the.machine);
        paris_safety_begin(paris_the.machine);
    }
}

/* The machine itself reads LUTETIA_LENIENT. */
void paris_safety_begin(struct machine *m)
{
    static bool asked, by_environment;
    if (!asked)
        by_environment = machine_lenient(m);
    asked = true;
    paris_the.lenient = mode == LENIENT || (mode == USUAL && by_environment);
    machine_lenient_set(m, paris_the.lenient);
}

void CM_set_safety_mode(unsigned int on)
{
    mode_set(on ? SAFE : LENIENT);
}

unsigned int CM_safety_mode(void)
{
    return paris_the.safety;
}

void paris_safety_usual(void)
{
    mode_set(USUAL);
}

bool paris_let_pass(const char *format, ...)
{
    static bool said;
    if (!paris_the.lenient)
        return false;
    if (!said) {
        const char *place = paris_call_line();
        char text[400];
        va_list args;
        va_start(args, format);
        vsnprintf(text, sizeof text, format, args);
        va_end(args);
        fflush(stdout);
        visible_say("%s%s%s: %s. This and more of the kind is let pass (said once); "
                    "CM_set_safety_mode (1) makes it an error",
                    place, *place ? ": " : "", paris_the.call, text);
    }
    return said = true;
}

bool paris_runs_over(CM_field_id_t field, unsigned int bits, const char *role)
{
    return paris_the.lenient && machine_field_runs_over(paris_the.machine, field, bits) &&
           paris_let_pass(
               "%s: %u bits from %u on run over the end of a field and go on in what "
               "lies after it",
               role, bits, field);
}
