/* number_text.h - numbers as text that is read back as the same number.
 *
 *     struct number_text_locale locale;
 *     if (!number_text_begin(&locale)) // decimal points, whatever the program's locale
 *         return no_memory();
 *     number_text_print(file, 0.1); // 0.1, not 0.10000000000000001
 *     number_text_end(&locale); */
#ifndef LUTETIA_NUMBER_TEXT_H
#define LUTETIA_NUMBER_TEXT_H

#include <locale.h>
#include <stdbool.h>
#include <stdio.h>

/* Between begin and end, numbers in this thread have a decimal point, whatever the program's
 * locale. False: no memory. */
struct number_text_locale {
    locale_t plain, before;
};
bool number_text_begin(struct number_text_locale *locale);
void number_text_end(struct number_text_locale *locale);

/* The shortest of the texts with 15, 16 and 17 digits that is read back as the same number.
 * Returns room. Any thread. */
enum { NUMBER_TEXT_BYTES = 40 };
const char *number_text(double value, char room[NUMBER_TEXT_BYTES]);
/* Prints it. */
void number_text_print(FILE *to, double value);

#endif
