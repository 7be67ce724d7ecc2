/* options.h - command-line options as rows of a table.
 *
 *     int steps = 200;
 *     const struct option_row rows[] = {
 *         {"steps", 0, OPTION_INTEGER, "N", "cycles to compute", &steps, 0, 1e6, 0},
 *         {0}};
 *     struct option_words words;
 *     if (!options_parse("paint", rows, argc, argv, &words))
 *         return EXIT_USAGE;
 *
 * Options are `--name value`, `--name=value` or `-o value`; `--` ends them; all else is a word.
 */
#ifndef LUTETIA_OPTIONS_H
#define LUTETIA_OPTIONS_H

#include <stdbool.h>

enum option_kind {
    OPTION_FLAG,    /* bool */
    OPTION_TEXT,    /* const char *: the argument itself, not empty */
    OPTION_PNG,     /* const char *: the name of a picture to be written, which no ending of
                       another format ends */
    OPTION_INTEGER, /* int within least..most */
    OPTION_NUMBER,  /* double within least..most; NaN and infinity are not */
    OPTION_NUMBERS, /* double[count], separated by commas, each within least..most */
    OPTION_SIZE,    /* int[2]: WxH, each within least..most */
    OPTION_LIST,    /* struct option_list: NUMBERS as often as wanted */
    OPTION_TEXTS    /* struct option_texts: TEXT as often as wanted */
};

enum {
    OPTION_LIST_MAX = 64,
    OPTION_NUMBERS_MAX = 8,
    OPTION_WORDS_MAX = 64,
    OPTION_ROWS_MAX = 96
};

struct option_list {
    double numbers[OPTION_LIST_MAX][OPTION_NUMBERS_MAX];
    int count;
};

struct option_texts {
    const char *texts[OPTION_LIST_MAX];
    int count;
};

struct option_row {
    const char *name; /* without the dashes; NULL ends the table */
    char letter;      /* of the short form, or 0 */
    enum option_kind kind;
    const char *value; /* the value's name in the help */
    const char *help;
    void *target;
    double least, most;
    int count; /* of OPTION_NUMBERS and OPTION_LIST */
};

struct option_words {
    const char *words[OPTION_WORDS_MAX];
    int count;
    bool help;                   /* --help or -h was given; other options were not read */
    bool given[OPTION_ROWS_MAX]; /* of the rows, in their order */
};

/* With what else an option has an effect. Alternatives are separated by |, what an alternative
 * needs by +: NAME is an option that is given, WORD a word; !NAME and !WORD are not given.
 * {"fps", "frames|video+!silent"} */
struct option_need {
    const char *name; /* NULL ends the table */
    const char *needs;
};

/* Fills the targets. False: an error was printed, in one line. */
bool options_parse(const char *verb, const struct option_row *rows, int argc, char **argv,
                   struct option_words *words);

/* After options_parse(). False: an option was given that would have no effect; an error was
 * printed, in one line. */
bool options_effects(const char *verb, const struct option_row *rows,
                     const struct option_need *needs, const struct option_words *words);

/* How many of argv are options of these rows, before the first word. The rest is the command
 * line of another program. */
int options_own(const struct option_row *rows, int argc, char **argv);

#endif
