/* explain.h - LUTETIA_EXPLAIN=FILE and LUTETIA_EXPLAIN_JSON=FILE: reports on what the
 * program's machines did, and why, as text and as JSON, written when the program ends.
 * `lutetia explain` uses both. */
#ifndef PARIS_EXPLAIN_H
#define PARIS_EXPLAIN_H

#include "machine_explained.h"

#include <stdio.h>

/* Whether a report is requested and its file can be written; if not, an error is printed
 * once. */
bool paris_explain_wanted(void);
/* Called when a machine has been made, before it is destroyed, and when the program ends.
 * machine NULL is fine. */
void paris_explain_begin(struct machine *m);
void paris_explain_end(struct machine *m);
void paris_explain_write(void);
/* A complaint of a call, with its line: the report has each text once, and how often it
 * came. */
void paris_explain_complaint(const char *text);

/* explain_text.c, explain_json.c: the report of one machine */
void explain_text(FILE *out, const struct machine_explained *x);
void explain_json(FILE *out, const struct machine_explained *x);
/* A string of JSON. */
void explain_json_text(FILE *out, const char *s);

/* explain_words.c: the kernel's bound: the time of copying as many bytes, or of the
 * operations by the cost model; 0: unknown. */
double explain_bound_s(const struct machine_explained_kernel *k, const char **by);
const char *explain_why(enum machine_cut why);
const char *explain_way(enum machine_plan_way way);
const char *explain_tier(enum machine_tier tier);
const char *explain_plan_why(enum machine_plan_why why);
const char *explain_number(enum machine_number number);

#endif
