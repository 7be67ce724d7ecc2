/* number_text.h - numbers as text that reads as the same number. */
#ifndef LUTETIA_DYN_NUMBER_TEXT_H
#define LUTETIA_DYN_NUMBER_TEXT_H

#include <locale.h>
#include <stdbool.h>
#include <stdio.h>

/* Between begin and end this thread's numbers have a point, whatever the program's locale. False: no memory. */
struct dyn_plain_numbers {
    locale_t plain, before;
};
bool dyn_plain_numbers_begin(struct dyn_plain_numbers *p);
void dyn_plain_numbers_end(struct dyn_plain_numbers *p);

/* The shortest of three texts that reads as the same number. */
void dyn_number_print(FILE *to, double value);

#endif
