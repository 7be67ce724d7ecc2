/* skip.h - a case that cannot be tried here says why: totals.py lists the reason beside its
 * name.
 *
 *     if (!have("midicsv"))
 *         skip_because("midicsv is not installed");
 */
#ifndef TESTS_SKIP_H
#define TESTS_SKIP_H

#define skip_because(...)                                                                      \
    do {                                                                                       \
        print_message(__VA_ARGS__);                                                            \
        print_message("\n");                                                                   \
        skip();                                                                                \
    } while (0)

#endif
