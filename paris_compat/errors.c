/* errors.c - the library's error state and error handling. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "call_line.h"
#include "debug.h"
#include "explain.h"
#include "paris_state.h"
#include "visible_text.h"

struct paris_state paris_the = {.call = "Paris"};

static char error_text[1400];
static unsigned int error_status; /* the CM_error_... that belongs to error_text */
static void (*error_handler)(const char *message);

void paris_error_print(void)
{
    fflush(stdout);
    visible_say("%s", error_text);
}

PARIS_PRINTF(2, 0) static void fail(unsigned int status, const char *format, va_list args)
{
    char text[1000];
    const char *line = paris_call_line();
    vsnprintf(text, sizeof text, format, args);
    snprintf(error_text, sizeof error_text, "%.200s%s%.100s: %s", line, *line ? ": " : "",
             paris_the.call, text);
    error_status = status;
    if (paris_the.machine)
        machine_call_failed(paris_the.machine);
    paris_debug_tell(error_text);
    paris_explain_complaint(error_text);
    if (error_handler) {
        error_handler(error_text);
        return;
    }
    paris_error_print();
    exit(1);
}

void paris_fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fail(CM_error_call, format, args);
    va_end(args);
}

void paris_fail_memory(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fail(CM_error_memory, format, args);
    va_end(args);
}

PARIS_PRINTF(2, 3) static void fail_as(unsigned int status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fail(status, format, args);
    va_end(args);
}

/* NULL: no machine could be made, for want of memory. */
static unsigned int status_of(const struct machine *m)
{
    enum machine_status status = m ? machine_status_last(m) : MACHINE_NO_MEMORY;
    if (status == MACHINE_NO_MEMORY)
        return CM_error_memory;
    return status == MACHINE_BAD_ARGUMENT ? CM_error_call : CM_error_device;
}

void paris_fail_machine(void)
{
    if (!paris_the.machine) {
        fail_as(CM_error_device, "there is no machine");
        return;
    }
    const char *said = machine_error(paris_the.machine);
    fail_as(status_of(paris_the.machine), "%s", *said ? said : "the machine could not do it");
    machine_error_clear(paris_the.machine);
}

void paris_fail_without(const struct machine *m)
{
    const char *said = m ? machine_error(m) : "";
    snprintf(error_text, sizeof error_text, "no Connection Machine: %s",
             *said ? said : "not enough memory");
    error_status = status_of(m);
}

unsigned int CM_error_status(void)
{
    return error_status;
}

const char *paris_error(void)
{
    return error_text;
}

void CM_set_error_handler(void (*handler)(const char *message))
{
    error_handler = handler;
}
