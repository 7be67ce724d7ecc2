/* runtime.c - the implicit machine: made when first needed, destroyed by CM_detach. */
#include <stdio.h>
#include <stdlib.h>

#include <part_files.h>

#include "explain.h"
#include "paris_state.h"

unsigned int CM_physical_processors_limit = 0;
unsigned int CM_physical_processors_length = 0;

static struct machine_config config_now;
static bool config_given;

void paris_machine_forget(void)
{
    paris_sets_forget();
    paris_explain_end(paris_the.machine);
    if (paris_the.machine && paris_the.machine_changes)
        paris_the.machine_changes(false);
    machine_destroy(paris_the.machine);
    paris_the.machine = NULL;
    CM_physical_processors_limit = 0;
    CM_physical_processors_length = 0;
}

static void leave(void)
{
    paris_explain_end(paris_the.machine);
    machine_leave(paris_the.machine);
    paris_explain_write();
}

bool paris_machine_make(void)
{
    if (!config_given)
        config_now = machine_config_default();
    struct machine *m = NULL;
    struct machine_config config = config_now;
    const char *leds = getenv("LUTETIA_LEDS"), *display = getenv("LUTETIA_DISPLAY");
    /* their files are opened after the driver's compiler has caught signals */
    if ((leds && *leds) || (display && *display))
        part_files_catch();
    config.explain = config.explain || paris_explain_wanted();
    if (machine_create(&config, &m) != MACHINE_OK) {
        paris_fail_without(m);
        machine_destroy(m);
        return false;
    }
    static bool registered;
    if (!registered) /* the program may exit while kernels still run */
        registered = atexit(leave) == 0;
    paris_explain_begin(m);
    paris_the.machine = m;
    if (paris_the.machine_changes)
        paris_the.machine_changes(true);
    paris_safety_begin(m);
    CM_physical_processors_limit = (unsigned int)machine_processors_count(m);
    CM_physical_processors_length = 0;
    while ((1u << CM_physical_processors_length) < CM_physical_processors_limit)
        CM_physical_processors_length++;
    paris_sets_reset();
    return true;
}

struct machine *paris_machine(void)
{
    if (!paris_the.machine && !paris_machine_make()) {
        paris_error_print();
        exit(1);
    }
    return paris_the.machine;
}

bool paris_reset(const struct machine_config *config)
{
    config_given = config != NULL;
    if (config)
        config_now = *config;
    paris_machine_forget();
    return paris_machine_make();
}

bool paris_reset_to(unsigned int processors)
{
    struct machine_config config = config_given ? config_now : machine_config_default();
    config.processors_count = (int)processors;
    return paris_reset(&config);
}
