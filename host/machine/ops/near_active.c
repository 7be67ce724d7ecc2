/* near_active.c - see near_active.h. */
#include "ops/near_active.h"

#include <string.h>

/* How many of n bytes from one end on are 0. */
static int idle_before(const unsigned char *context, int n)
{
    int i = 0;
    uint64_t eight;
    for (; i + 8 <= n; i += 8) {
        memcpy(&eight, context + i, sizeof eight);
        if (eight)
            break;
    }
    while (i < n && !context[i])
        i++;
    return i;
}

static int idle_after(const unsigned char *context, int n)
{
    int i = n;
    uint64_t eight;
    for (; i >= 8; i -= 8) {
        memcpy(&eight, context + i - 8, sizeof eight);
        if (eight)
            break;
    }
    while (i > 0 && !context[i - 1])
        i--;
    return n - i;
}

struct stretch near_active_part(const struct stretch *s)
{
    const struct line_scan *j = s->j;
    struct stretch part = *s;
    if (!j->context || j->bits || (s->step != 1 && s->step != -1))
        return part;
    const int n = s->end - s->begin;
    const bool up = s->step > 0;
    const unsigned char *context =
        (const unsigned char *)j->context->host + (up ? s->at : s->at - (size_t)n + 1);
    const int low = idle_before(context, n), high = low < n ? idle_after(context, n) : 0,
              before = up ? low : high, after = up ? high : low;
    part.begin = low < n ? s->begin + before : s->end;
    part.end -= low < n ? after : 0;
    part.at += (size_t)(up ? before : -before);
    return part;
}
