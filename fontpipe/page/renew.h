/* renew.h - what renew.c and renew_glyphs.c share. */
#ifndef LUTETIA_PAGE_RENEW_H
#define LUTETIA_PAGE_RENEW_H

#include "page_internal.h"

struct renewal {
    struct page_text *t;
    struct paragraph *p;
    int begin, end_before, end; /* letters that are others: where they were, where they are */
    int from, to;               /* letters that may have got another face, level, script ... */
    struct letter *fresh;
    int fresh_count, fresh_capacity;
    struct set_run *runs_before; /* with their glyphs */
    int runs_before_count;
};

/* The number of the run that has the letter. */
int renew_run_at(const struct set_run *runs, int count, int letter);
/* The glyphs, once the runs are known. False: all must be set anew. */
bool renew_glyphs(struct renewal *r);

#endif
