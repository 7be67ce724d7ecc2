/* sheet_chance.h - sheets, airs and screens by chance. */
#ifndef LUTETIA_TEST_SHEET_CHANCE_H
#define LUTETIA_TEST_SHEET_CHANCE_H

#include <paper.h>
#include <sheet.h>

#include <stdint.h>

enum { CHANCE_PIGMENTS = 3 };

/* All that follows depends on the seed alone. */
void chance_begin(uint64_t seed);
uint64_t chance_word(void);
/* 0..n-1. */
int below(int n);
/* One number in three is at an end of the range, some are near the low end. */
double within(double low, double high);
/* Ends the program with the seed, and what was wrong. */
__attribute__((noreturn, format(printf, 1, 2))) void wrong(const char *format, ...);
void check(enum paper_status status);

/* Sides least..most. */
struct paper_sheet_config config_by_chance(int least, int most);
/* A deckle for one sheet in three of those that can have one. */
void deckle_by_chance(struct paper_sheet_config *config);
struct paper_air air_by_chance(void);
/* Shape: gray has most * most bytes. */
struct paper_screen screen_by_chance(uint8_t *gray, int most);

#endif
