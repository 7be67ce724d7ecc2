/* kit.c - see kit.h. */
#include "kit.h"

#include <stdio.h>

static enum kit_status first; /* since kit_begin() */
static char words[512];       /* of it */

static enum kit_status status_now(void)
{
    switch (CM_error_status()) {
    case CM_error_memory:
        return KIT_NO_MEMORY;
    case CM_error_device:
        return KIT_DEVICE_FAILED;
    default:
        return KIT_WRONG_CALL;
    }
}

static void complaint_take(const char *message)
{
    if (first != KIT_OK)
        return;
    first = status_now();
    snprintf(words, sizeof words, "%s", message);
}

enum kit_status kit_attach(void)
{
    CM_set_error_handler(complaint_take);
    if (CM_attached())
        return KIT_OK;
    first = KIT_OK;
    if (CM_attach() != 0)
        return KIT_OK;
    if (first == KIT_OK)
        snprintf(words, sizeof words, "there is no OpenCL device");
    return CM_error_status() == CM_error_memory ? KIT_NO_MEMORY : KIT_NO_DEVICE;
}

void kit_begin(void)
{
    first = KIT_OK;
}

void kit_enter(CM_vp_set_id_t set)
{
    kit_begin();
    CM_set_vp_set(set);
}

enum kit_status kit_leave(void)
{
    return first;
}

enum kit_status kit_finish(CM_vp_set_id_t set)
{
    kit_enter(set);
    CM_warm_boot();
    return kit_leave();
}

const char *kit_error(void)
{
    return words;
}
