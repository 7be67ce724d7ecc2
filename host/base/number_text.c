/* number_text.c - see number_text.h. */
#include "number_text.h"

#include <stdlib.h>

bool number_text_begin(struct number_text_locale *locale)
{
    locale->plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (locale->plain)
        locale->before = uselocale(locale->plain);
    return locale->plain != (locale_t)0;
}

void number_text_end(struct number_text_locale *locale)
{
    uselocale(locale->before);
    freelocale(locale->plain);
}

const char *number_text(double value, char room[NUMBER_TEXT_BYTES])
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(room, NUMBER_TEXT_BYTES, "%.*g", digits, value);
        if (strtod(room, NULL) == value)
            break;
    }
    return room;
}

void number_text_print(FILE *to, double value)
{
    char text[NUMBER_TEXT_BYTES];
    fputs(number_text(value, text), to);
}
