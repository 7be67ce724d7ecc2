/* machine.c - enters and leaves the machine, and converts its errors to the paper's. */
#include "base/page.h"

#include <kit.h>

static enum paper_status status_of(enum kit_status status)
{
    switch (status) {
    case KIT_OK:
        return PAPER_OK;
    case KIT_NO_DEVICE:
        return paper_fail(PAPER_NO_DEVICE, "%s", kit_error());
    case KIT_NO_MEMORY:
        return paper_fail(PAPER_NO_MEMORY, "%s", kit_error());
    case KIT_DEVICE_FAILED:
    case KIT_WRONG_CALL:
        break;
    }
    return paper_fail(PAPER_MACHINE_FAILED, "%s", kit_error());
}

enum paper_status paper_attach(void)
{
    return status_of(kit_attach());
}

void paper_enter(struct paper *p)
{
    kit_enter(p->grid.vp_set);
}

enum paper_status paper_leave(struct paper *p)
{
    (void)p;
    return status_of(kit_leave());
}

enum paper_status paper_finish(struct paper *p)
{
    return status_of(kit_finish(p->grid.vp_set));
}
