/* accessible.c - see accessible.h. */
#include "accessible.h"

#include <unistd.h>

#include "clock.h"

void accessible_walk(AtspiAccessible *a, accessible_each *each, void *context)
{
    const AtspiRole role = atspi_accessible_get_role(a, NULL);
    each(a, context);
    if (role == ATSPI_ROLE_SPIN_BUTTON || role == ATSPI_ROLE_COMBO_BOX)
        return;
    const int count = atspi_accessible_get_child_count(a, NULL);
    for (int i = 0; i < count; i++) {
        AtspiAccessible *child = atspi_accessible_get_child_at_index(a, i, NULL);
        if (child)
            accessible_walk(child, each, context);
        g_clear_object(&child);
    }
}

AtspiAccessible *accessible_frame_wait(double seconds)
{
    const double until_s = clock_now_s() + seconds;
    while (clock_now_s() < until_s) {
        AtspiAccessible *desktop = atspi_get_desktop(0),
                        *program = atspi_accessible_get_child_at_index(desktop, 0, NULL);
        if (program && atspi_accessible_get_child_count(program, NULL) > 0)
            return atspi_accessible_get_child_at_index(program, 0, NULL);
        g_clear_object(&program);
        atspi_accessible_clear_cache(desktop);
        usleep(100000);
    }
    return NULL;
}
