/* number_text.c - see number_text.h. */
#include "number_text.h"

#include <stdlib.h>

bool dyn_plain_numbers_begin(struct dyn_plain_numbers *p)
{
    p->plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (p->plain)
        p->before = uselocale(p->plain);
    return p->plain != (locale_t)0;
}

void dyn_plain_numbers_end(struct dyn_plain_numbers *p)
{
    uselocale(p->before);
    freelocale(p->plain);
}

void dyn_number_print(FILE *to, double value)
{
    char text[40];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value)
            break;
    }
    fputs(text, to);
}
