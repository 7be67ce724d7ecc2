/* sheet_chance.c - see sheet_chance.h. */
#include "sheet_chance.h"

#include "../sample.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t chance, first_seed;

void chance_begin(uint64_t seed)
{
    first_seed = seed;
    chance = seed * 0x2545f4914f6cdd1d;
}

uint64_t chance_word(void)
{
    return sample_word(&chance);
}

int below(int n)
{
    return (int)(sample_word(&chance) % (uint64_t)n);
}

double within(double low, double high)
{
    uint64_t word = sample_word(&chance);
    switch (word % 6) {
    case 0:
        return low;
    case 1:
        return high;
    case 2: /* orders of magnitude near the low end */
        return low + (high - low) * ldexp(1, -(int)(word >> 8 & 31));
    default:
        return low + (high - low) * (double)(word >> 11) * 0x1p-53;
    }
}

void wrong(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fprintf(stderr, "set %llu: ", (unsigned long long)first_seed);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
    va_end(arguments);
    exit(1);
}

void check(enum paper_status status)
{
    if (status != PAPER_OK)
        wrong("status %d: %s", (int)status, paper_error());
}

static struct paper_pigment pigment_by_chance(void)
{
    struct paper_pigment pigment = *paper_pigment_number(below(15));
    if (below(2))
        return pigment;
    for (int i = 0; i < 2; i++)
        pigment.weight[i] = within(0, 1);
    pigment.density = within(0, 1);
    pigment.staining = within(0.5, 100);
    pigment.granulation = within(0, 1);
    for (int i = 0; i < 3; i++) {
        pigment.k[i] = within(0, 100);
        pigment.s[i] = within(0, 100);
        pigment.takes[i] = within(-1, 1);
    }
    return pigment;
}

struct paper_sheet_config config_by_chance(int least, int most)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = least + below(most - least + 1);
    config.height = least + below(most - least + 1);
    config.torus = below(2);
    config.parts = (unsigned)(below(3) ? 15 : below(16));
    config.rule = (enum paper_rule)below(3);
    config.seed = sample_word(&chance);
    int stocks = 0;
    while (paper_stock_number(stocks))
        stocks++;
    config.stock = *paper_stock_number(below(stocks));
    if (below(2)) {
        struct paper_stock *stock = &config.stock;
        stock->color_variation = within(0, 1);
        stock->absorbency = within(0, PAPER_ABSORBENCY_MAX);
        stock->absorbency_variation = within(0, 1);
        for (int i = 0; i < 2; i++) {
            stock->absorbency_along[i] = within(0, 1);
            stock->capacity[i] = within(0.01, 1);
            stock->fiber_length[i] = (int)within(1, 64);
        }
        stock->roughness = within(0, 1);
        stock->grain_px = within(1, 64);
    }
    config.pigments_count = below(CHANCE_PIGMENTS + 1);
    for (int i = 0; i < config.pigments_count; i++)
        config.pigments[i] = pigment_by_chance();
    return config;
}

void deckle_by_chance(struct paper_sheet_config *config)
{
    const int side = config->width < config->height ? config->width : config->height;
    config->deckled = config->parts && !config->torus &&
                      strcmp(config->stock.name, "glass") != 0 && below(3) == 0;
    if (!config->deckled)
        return;
    config->deckle.margin = within(2, side / 4.0);
    config->deckle.thin = within(1, side / 4.0 - 0.5);
    config->deckle.waves = within(0, 4);
    config->deckle.fringe = within(0, 6);
}

struct paper_air air_by_chance(void)
{
    struct paper_air air = paper_air_default();
    for (int i = 0; i < 2; i++) {
        air.gravity[i] = within(-1, 1);
        air.seep[i] = within(-1, 1);
    }
    air.spread = within(0, 1);
    air.relief = within(0, 1);
    air.film = within(0.001, 1);
    air.pinning = within(0, 2);
    air.absorption = within(0, 4);
    air.carry = within(0, 1);
    air.humidity = within(0, 1);
    air.edge = within(0, 200);
    air.edge_width = within(1, 32);
    air.settling = within(0, 10);
    air.thesis.gravity_x = within(0.5, 2);
    air.thesis.gravity_y = within(0.5, 2);
    air.thesis.humidity = within(0, 1);
    return air;
}

struct paper_screen screen_by_chance(uint8_t *gray, int most)
{
    struct paper_screen screen = {
        .width_px = 1 + below(most), .height_px = 1 + below(most), .gray = gray};
    for (int i = 0; i < screen.width_px * screen.height_px; i++)
        gray[i] = (uint8_t)within(0, 255);
    return screen;
}
