/* number_text.h - numbers as text that is read back as the same number. */
#ifndef LUTETIA_DYN_NUMBER_TEXT_H
#define LUTETIA_DYN_NUMBER_TEXT_H

#include <locale.h>
#include <stdbool.h>
#include <stdio.h>

/* Between begin and end, numbers in this thread have a decimal point, whatever the program's
 * locale. False: no memory. */
struct dyn_plain_numbers {
    locale_t plain, before;
};
bool dyn_plain_numbers_begin(struct dyn_plain_numbers *p);
void dyn_plain_numbers_end(struct dyn_plain_numbers *p);

/* Prints the shortest of three texts that is read back as the same number. */
void dyn_number_print(FILE *to, double value);

#endif
