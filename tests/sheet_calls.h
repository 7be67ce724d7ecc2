/* sheet_calls.h - calls of sheets that must succeed, and how much is tried. */
#ifndef LUTETIA_TESTS_SHEET_CALLS_H
#define LUTETIA_TESTS_SHEET_CALLS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <paper.h>
#include <sheet.h>

static inline void check(enum paper_status status)
{
    if (status != PAPER_OK)
        fail_msg("status %d: %s", (int)status, paper_error());
}

/* With PAPER_TEST_FULL=1 all sheets are tried; else those that are most likely to fail. */
static inline bool all_sheets_wanted(void)
{
    const char *full = getenv("PAPER_TEST_FULL");
    return full && strcmp(full, "1") == 0;
}

/* Of a square sheet with that side. corners: x, y of each. */
static inline void polygon_put(struct paper_sheet *sheet, int side, const double *corners,
                               int count, const double *amount)
{
    struct paper_screen screen;
    int x, y;
    check(paper_polygon_screen(corners, count, side, side, &screen, &x, &y));
    check(paper_sheet_put(sheet, &screen, x, y, amount));
    paper_screen_destroy(&screen);
}

static inline void disc_put(struct paper_sheet *sheet, int side, double x, double y,
                            double radius, const double *amount)
{
    enum { CORNERS = 90 };
    const double turn = 6.283185307179586;
    double corners[2 * CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        corners[2 * i] = x + radius * cos(turn * i / CORNERS);
        corners[2 * i + 1] = y + radius * sin(turn * i / CORNERS);
    }
    polygon_put(sheet, side, corners, CORNERS, amount);
}

#endif
