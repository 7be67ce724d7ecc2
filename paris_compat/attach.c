/* attach.c - how a program gets and leaves the machine. */
#include <stdlib.h>

#include "paris_state.h"

/* A machine that was made just now. False: it was not, or cannot begin; paris_error() has the
 * reason. */
static bool begin(bool made)
{
    if (!made || paris_warm_up())
        return made;
    paris_fail_without(paris_the.machine);
    paris_machine_forget();
    return false;
}

static bool attach(void)
{
    return paris_the.machine || begin(paris_machine_make());
}

unsigned int CM_attach(void)
{
    paris_the.call = "CM_attach";
    if (!attach()) {
        paris_error_print();
        return 0;
    }
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
    return begin(paris_reset_to(count)) ? CM_physical_processors_limit : 0;
}

int CM_attached(void)
{
    return paris_the.machine != NULL;
}

void CM_detach(void)
{
    paris_machine_forget();
}

void CM_init(void)
{
    if (!attach()) {
        paris_error_print();
        exit(1);
    }
    paris_the.call = "CM_init";
    machine_begin(paris_the.machine);
    if (!paris_the.pristine)
        paris_sets_reset();
}

void CM_cold_boot(void)
{
    CM_init();
}

void CM_warm_boot(void)
{
    struct machine *m = paris_machine();
    machine_instruction(m, "CM_warm_boot");
    paris_the.call = "CM_warm_boot";
    if (machine_finish(m) != MACHINE_OK)
        paris_fail_machine();
}
