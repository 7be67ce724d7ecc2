/* known.c - see known.h. */
#include "plans/known.h"

#include <stdio.h>
#include <stdlib.h>

#include "device/disk_cache.h"
#include "plans/background.h"

/* A folder's path, the device's options, and some numbers. */
enum { NAME_BYTES = 2048 };

/* False: too long. */
static bool name_of(const struct machine *m, uint64_t alike, const struct plan_form *form,
                    char name[NAME_BYTES])
{
    const char *folder = getenv("POCL_CACHE_DIR");
    int n =
        snprintf(name, NAME_BYTES, "plan %016llx, %d, %s\n%s\n%s", (unsigned long long)alike,
                 (int)form->quality, form->lifted ? "lifted" : "written", folder ? folder : "",
                 m->device->options);
    return n > 0 && n < NAME_BYTES;
}

bool known_find(struct machine *m, const struct plan_request *q, struct plan_form *form)
{
    static const struct plan_form forms[] = {
        {BOXED, false}, {BOXED, true}, {OPTIMISED, false}, {OPTIMISED, true}};
    char name[NAME_BYTES];
    if (!m->settings.keep || !background_on(m))
        return false;
    const uint64_t alike = plan_alike(m, q->reach, q->targets);
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (name_of(m, alike, &forms[i], name) && cache_mark_is_there(m->device, name)) {
            *form = forms[i];
            return true;
        }
    return false;
}

void known_prepare(const struct machine *m, struct plan *p, const struct plan_request *q)
{
    if (m->settings.keep && !p->empty)
        p->alike = plan_alike(m, q->reach, q->targets);
}

void known_keep(const struct machine *m, const struct plan *p, const struct plan *better)
{
    const struct plan_form form = {better->quality, better->lifted};
    char name[NAME_BYTES];
    if (p->alike && name_of(m, p->alike, &form, name))
        cache_mark_write(m->device, name);
}
