/* explain.h - LUTETIA_EXPLAIN=FILE and LUTETIA_EXPLAIN_JSON=FILE: what the program's machines did, and why, as text
 * and as JSON, written when the program ends. `lutetia explain` asks for both. */
#ifndef PARIS_EXPLAIN_H
#define PARIS_EXPLAIN_H

#include "machine_explained.h"

#include <stdio.h>

/* One of them is asked for, and its file can be written; what cannot be is said, once. */
bool paris_explain_wanted(void);
/* A machine has been made, or is going to be destroyed, or the program ends. machine NULL is fine. */
void paris_explain_begin(struct machine *m);
void paris_explain_end(struct machine *m);
void paris_explain_write(void);

/* explain_text.c, explain_json.c: one machine */
void explain_text(FILE *out, const struct machine_explained *x);
void explain_json(FILE *out, const struct machine_explained *x);

/* explain_words.c: the kernel's bound, by what it is: as many bytes copied, or the cost model's operations; 0: not known. */
double explain_bound_s(const struct machine_explained_kernel *k, const char **by);
const char *explain_why(enum machine_cut why);
const char *explain_way(enum machine_plan_way way);

#endif
