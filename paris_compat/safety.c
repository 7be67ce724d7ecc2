/* safety.c - the modes of checking calls.
 *
 *     at a program's start    errors are reported
 *     CM_set_safety_mode (1)  every argument is also checked before the machine is called
 *     CM_set_safety_mode (0)  lenient, as LUTETIA_LENIENT=1: what the real machine accepted is
 *                             accepted, and reported once
 *
 * In every mode, nothing outside the machine's own memory is read or written.
 */
#include <stdarg.h>
#include <stdio.h>

#include "call_line.h"
#include "debug.h"
#include "machine_told.h"
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

/* One line on the standard error, with the line of the call. */
static void say(const char *text)
{
    const char *place = paris_call_line();
    char all[1000];
    snprintf(all, sizeof all,
             "%.200s%s%.100s: %s (said once); CM_set_safety_mode (1) makes it an error", place,
             *place ? ": " : "", paris_the.call, text);
    paris_debug_tell(all);
    fflush(stdout);
    visible_say("%s", all);
}

bool paris_let_pass(const char *format, ...)
{
    static bool said;
    if (!paris_the.lenient)
        return false;
    if (!said) {
        char text[400];
        va_list args;
        va_start(args, format);
        int length = vsnprintf(text, sizeof text, format, args);
        va_end(args);
        if (length >= 0 && (size_t)length < sizeof text)
            snprintf(text + length, sizeof text - (size_t)length,
                     ". This and more of the kind is let pass");
        say(text);
    }
    return said = true;
}

void paris_tell_lost(struct machine *m, struct machine_value *send_address, int vp_set)
{
    static bool said;
    char text[200];
    uint64_t lost = 0;
    if (said || paris_the.safety || !machine_sent_beyond(m) ||
        machine_addresses_check(m, send_address, vp_set, &lost) != MACHINE_OK)
        return;
    said = true;
    snprintf(text, sizeof text,
             "send_address: in %llu active processors it is that of no processor of VP set %d, "
             "which has %llu. Messages to nobody are "
             "lost",
             (unsigned long long)lost, vp_set,
             (unsigned long long)machine_vpset_count(m, vp_set));
    say(text);
}

bool paris_runs_over(CM_field_id_t field, unsigned int bits, const char *role)
{
    return paris_the.lenient && machine_field_runs_over(paris_the.machine, field, bits) &&
           paris_let_pass(
               "%s: %u bits from %u on run over the end of a field and go on in what "
               "lies after it",
               role, bits, field);
}
