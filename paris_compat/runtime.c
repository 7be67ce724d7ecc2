/* The implicit machine: made when first needed, given back by CM_detach, and the one place
 * where errors end. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "explain.h"
#include "paris_state.h"

unsigned int CM_physical_processors_limit = 0;
unsigned int CM_physical_processors_length = 0;

struct paris_state paris_the = {.call = "Paris"};

static struct machine_config config_now;
static bool config_given;
static char error_text[1024];
static unsigned int error_status; /* CM_error_...: of what error_text says */
static void (*error_handler)(const char *message);

/* ---- errors ---- */

PARIS_PRINTF(2, 0) static void fail(unsigned int status, const char *format, va_list args)
{
    char text[sizeof error_text - 128];
    vsnprintf(text, sizeof text, format, args);
    snprintf(error_text, sizeof error_text, "%.100s: %s", paris_the.call, text);
    error_status = status;
    if (paris_the.machine)
        machine_call_failed(paris_the.machine);
    if (error_handler) {
        error_handler(error_text);
        return;
    }
    fflush(stdout);
    fprintf(stderr, "%s\n", error_text);
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

/* NULL: there is no machine, for want of memory. */
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

void CM_set_safety_mode(unsigned int on)
{
    if (paris_the.machine)
        machine_calls_forget(paris_the.machine);
    paris_the.safety = on;
}

unsigned int CM_safety_mode(void)
{
    return paris_the.safety;
}

/* ---- the machine ---- */

static void machine_forget(void)
{
    paris_sets_forget();
    paris_explain_end(paris_the.machine);
    machine_destroy(paris_the.machine);
    paris_the.machine = NULL;
    paris_the.attached = false;
    CM_physical_processors_limit = 0;
    CM_physical_processors_length = 0;
}

static void leave(void)
{
    paris_explain_end(paris_the.machine);
    machine_leave(paris_the.machine);
    paris_explain_write();
}

/* False: there is none, and error_text says why. */
static bool machine_make(void)
{
    if (!config_given)
        config_now = machine_config_default();
    struct machine *m = NULL;
    struct machine_config config = config_now;
    config.explain = config.explain || paris_explain_wanted();
    if (machine_create(&config, &m) != MACHINE_OK) {
        const char *said = m ? machine_error(m) : "";
        snprintf(error_text, sizeof error_text, "no Connection Machine: %s",
                 *said ? said : "not enough memory");
        error_status = status_of(m);
        machine_destroy(m);
        return false;
    }
    static bool registered;
    if (!registered) /* a program may leave with kernels still running */
        registered = atexit(leave) == 0;
    paris_explain_begin(m);
    paris_the.machine = m;
    paris_the.attached = true;
    CM_physical_processors_limit = (unsigned int)machine_processors_count(m);
    CM_physical_processors_length = 0;
    while ((1u << CM_physical_processors_length) < CM_physical_processors_limit)
        CM_physical_processors_length++;
    const char *call = paris_the.call; /* of what needs the machine: messages are about it */
    paris_sets_reset();
    paris_the.call = call;
    return true;
}

struct machine *paris_machine(void)
{
    if (!paris_the.machine && !machine_make()) {
        fflush(stdout);
        fprintf(stderr, "%s\n", error_text);
        exit(1);
    }
    return paris_the.machine;
}

bool paris_reset(const struct machine_config *config)
{
    config_given = config != NULL;
    if (config)
        config_now = *config;
    machine_forget();
    return machine_make();
}

/* ---- as programs say it ---- */

unsigned int CM_attach(void)
{
    paris_the.call = "CM_attach";
    if (!paris_the.machine && !machine_make()) {
        fprintf(stderr, "%s\n", error_text);
        return 0;
    }
    paris_the.attached = true;
    return CM_physical_processors_limit;
}

unsigned int CM_attach_to_processors(unsigned int count)
{
    paris_the.call = "CM_attach_to_processors";
    if (count == 0 || (count & (count - 1)) || count > 1u << 30) {
        paris_fail("count (%u): must be a power of two up to 2^30", count);
        return 0;
    }
    if (paris_the.machine && CM_physical_processors_limit == count)
        return CM_attach();
    struct machine_config config = config_given ? config_now : machine_config_default();
    config.processors_count = (int)count;
    return paris_reset(&config) ? CM_physical_processors_limit : 0;
}

int CM_attached(void)
{
    return paris_the.attached;
}

void CM_detach(void)
{
    machine_forget();
}

void CM_init(void)
{
    struct machine *m = paris_machine();
    paris_the.call = "CM_init";
    paris_the.attached = true;
    machine_begin(m);
    if (!paris_the.pristine)
        paris_sets_reset();
}

void CM_cold_boot(void)
{
    CM_init();
}

void CM_warm_boot(void)
{
    struct machine *m = paris_begin("CM_warm_boot");
    if (machine_finish(m) != MACHINE_OK)
        paris_fail_machine();
}
