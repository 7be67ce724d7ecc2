/* help.h - what `lutetia VERB --help` prints: a verb's page (pages.h) and its rows of options.
 *
 *     if (words.help)
 *         return help_print("paint", rows, NULL);
 *
 * The same is printed as a table of one line a fact after help_as_table(), which
 * `lutetia help --table` calls: manual pages and completions are made of it
 * (docs/manual/manual.py). */
#ifndef LUTETIA_HELP_H
#define LUTETIA_HELP_H

#include "options.h"

#include <stdio.h>

/* What a verb can be told to do: `lutetia midi serve`. */
struct help_command {
    const char *name; /* NULL ends the list */
    const char *arguments, *help;
};

/* Prints the page on the standard output. rows and commands may be NULL. EXIT_SUCCESS. */
int help_print(const char *verb, const struct option_row *rows,
               const struct help_command *commands);

/* Prints the usage and the commands alone: what a command line without words gets. */
void help_usage(FILE *out, const char *verb, const struct help_command *commands);

/* From now on help_print() prints a table: kinds of facts and their parts, separated by
 * tabs. */
void help_as_table(void);
bool help_is_table(void);

/* The variables of the environment, as text in columns; as a table also the exit statuses. */
void help_environment(void);

#endif
