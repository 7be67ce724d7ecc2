/* environment.h - the variables of the environment that the command and libparis look at, a row
 * each: `lutetia info --variables` and the manual pages print them. */
#ifndef LUTETIA_ENVIRONMENT_H
#define LUTETIA_ENVIRONMENT_H

enum environment_group {
    ENVIRONMENT_USER,   /* what every program looks at */
    ENVIRONMENT_PARIS,  /* what shows what a program in C/Paris does */
    ENVIRONMENT_MIDI,   /* instruments and sound */
    ENVIRONMENT_ENGINE, /* what forces decisions of the engine: for measuring and for tests */
    ENVIRONMENT_OTHERS  /* those of other programs, which count here, too */
};

struct environment_row {
    const char *name; /* NULL ends the table */
    const char *value;
    enum environment_group group;
    const char *does;
};

extern const struct environment_row environment_rows[];

const char *environment_group_name(enum environment_group group);

#endif
