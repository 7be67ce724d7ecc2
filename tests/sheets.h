/* sheets.h - small sheets with two pigments, for tests in which the sheet's configuration does
 * not matter. */
#ifndef LUTETIA_TESTS_SHEETS_H
#define LUTETIA_TESTS_SHEETS_H

#include <paper.h>
#include <sheet.h>

static inline struct paper_sheet_config sheet_of_two(int width, int height, const char *first,
                                                     const char *second)
{
    struct paper_sheet_config config = paper_sheet_config_default();
    config.width = width;
    config.height = height;
    config.pigments_count = 2;
    config.pigments[0] = *paper_pigment_find(first);
    config.pigments[1] = *paper_pigment_find(second);
    return config;
}

/* The same with the pigments of Curtis et al. 1997: tests whose bounds were found with their
 * numbers. */
static inline struct paper_sheet_config sheet_of_curtis(int width, int height,
                                                        const char *first, const char *second)
{
    struct paper_sheet_config config = sheet_of_two(width, height, first, second);
    config.pigments[0] = *paper_pigment_curtis(first);
    config.pigments[1] = *paper_pigment_curtis(second);
    return config;
}

#endif
