/* read_manual.h - the manual, which `lutetia read` opens where no file is named. */
#ifndef LUTETIA_READ_MANUAL_H
#define LUTETIA_READ_MANUAL_H

#include "options.h"

/* Puts the manual's files, in their order, in place of the words that are missing: those of a
 * build, or those that were installed. EXIT_SUCCESS, or says what is missing. Owns: this
 * file. */
int read_manual_words(struct option_words *words);

#endif
