/* stocks.c - papers by name. The first five are kinds of the first model too, where they are
 * woven noise; what they are made of from the second on is in model/felt.c. */
#include "sheet.h"

#include <stdio.h>
#include <strings.h>

static const struct paper_stock stocks[] = {
    {"cold press", {.975, .965, .94}, .25, .10, .5, {1, 1}, {.3, .75}, .16, 6, {8, 8}},
    {"hot press", {.98, .975, .96}, .12, .09, .35, {1, 1}, {.35, .6}, .05, 2, {6, 6}},
    {"rough", {.96, .945, .91}, .35, .10, .6, {1, 1}, {.25, .9}, .26, 11, {12, 12}},
    {"blotting", {.95, .93, .90}, .2, .24, .3, {1, 1}, {.8, 1}, .08, 3, {4, 4}},
    {"glass", {.97, .98, .98}, 0, .002, 0, {1, 1}, {.02, .02}, 0, 1, {1, 1}},
    {"laid", {.965, .95, .91}, .3, .11, .45, {1, 1}, {.3, .7}, .10, 4, {10, 8}},
    {"xuan", {.955, .945, .915}, .45, .22, .55, {1, 1}, {.7, 1}, .06, 3, {12, 12}},
};

enum { STOCKS_COUNT = sizeof stocks / sizeof *stocks };

const struct paper_stock *paper_stock_number(int number)
{
    return number >= 0 && number < STOCKS_COUNT ? &stocks[number] : NULL;
}

const struct paper_stock *paper_stock_find(const char *name)
{
    for (int i = 0; i < STOCKS_COUNT; i++)
        if (strcasecmp(stocks[i].name, name) == 0)
            return &stocks[i];
    return NULL;
}

void paper_stock_names(char *text, size_t room)
{
    size_t used = 0;
    *text = '\0';
    for (int i = 0; i < STOCKS_COUNT && used < room; i++)
        used +=
            (size_t)snprintf(text + used, room - used, "%s%s", i ? ", " : "", stocks[i].name);
}
