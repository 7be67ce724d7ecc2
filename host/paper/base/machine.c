/* machine.c - where the sheet meets the machine: attaching it, its complaints, and contexts.
 *
 * Paris reports a call that fails to a handler and goes on without it.  What happens between paper_enter() and
 * paper_leave() therefore runs to its end, and the first complaint is what the caller hears. */
#include "base/page.h"

#include <stdio.h>
#include <string.h>

static char complaint[512]; /* the first since paper_enter(); "" if none */

static void complaint_take(const char *message)
{
    if (!complaint[0])
        snprintf(complaint, sizeof complaint, "%s",
                 message && *message ? message : "no reason given");
}

/* Paris has words only, and both its own and the machine's speak of memory where memory was short. */
static enum paper_status complaint_status(void)
{
    return strstr(complaint, "memory") ? PAPER_NO_MEMORY : PAPER_MACHINE_FAILED;
}

enum paper_status paper_attach(void)
{
    CM_set_error_handler(complaint_take);
    if (CM_attached())
        return PAPER_OK;
    complaint[0] = '\0';
    if (CM_attach() == 0)
        return paper_fail(PAPER_NO_DEVICE, "%s",
                          complaint[0] ? complaint : "there is no OpenCL device");
    return PAPER_OK;
}

void paper_enter(struct paper *p)
{
    complaint[0] = '\0';
    CM_set_vp_set(p->vp_set);
}

enum paper_status paper_leave(struct paper *p)
{
    (void)p;
    if (complaint[0])
        return paper_fail(complaint_status(), "%s", complaint);
    return PAPER_OK;
}

enum paper_status paper_finish(struct paper *p)
{
    paper_enter(p);
    CM_warm_boot();
    return paper_leave(p);
}

void paper_context_rectangle(struct paper *p, int x1, int y1, int x2, int y2)
{
    unsigned x_bits = (unsigned)p->x_bits, y_bits = (unsigned)p->y_bits;
    x2 = x2 < p->width ? x2 : p->width;
    y2 = y2 < p->height ? y2 : p->height;
    CM_store_context(p->context);
    if (x1 >= x2 || y1 >= y2) {
        CM_clear_context();
        return;
    }
    if (x1 > 0) {
        CM_u_ge_constant_1L(p->x_coord, (unsigned)x1, x_bits);
        CM_logand_context_with_test();
    }
    if (y1 > 0) {
        CM_u_ge_constant_1L(p->y_coord, (unsigned)y1, y_bits);
        CM_logand_context_with_test();
    }
    if (x2 < p->width) {
        CM_u_lt_constant_1L(p->x_coord, (unsigned)x2, x_bits);
        CM_logand_context_with_test();
    }
    if (y2 < p->height) {
        CM_u_lt_constant_1L(p->y_coord, (unsigned)y2, y_bits);
        CM_logand_context_with_test();
    }
}

void paper_context_restore(struct paper *p)
{
    CM_load_context(p->context);
}
