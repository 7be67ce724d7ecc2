/* likeness.c - see likeness.h. */
#include "likeness.h"

#include <assert.h>
#include <math.h>

static double gray_at(const struct display_image *image, int x, int y)
{
    const uint8_t *p = image->pixels + 3 * ((long)y * image->width_px + x);
    return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
}

static double square(const struct display_image *a, const struct display_image *b, int x0,
                     int y0)
{
    const double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (int y = y0; y < y0 + 8; y++)
        for (int x = x0; x < x0 + 8; x++) {
            double p = gray_at(a, x, y), q = gray_at(b, x, y);
            sa += p;
            sb += q;
            saa += p * p;
            sbb += q * q;
            sab += p * q;
        }
    double ma = sa / 64, mb = sb / 64;
    double va = saa / 64 - ma * ma, vb = sbb / 64 - mb * mb, cov = sab / 64 - ma * mb;
    return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

double likeness(const struct display_image *a, const struct display_image *b)
{
    double sum = 0;
    long count = 0;
    assert(a->width_px == b->width_px && a->height_px == b->height_px);
    for (int y = 0; y + 8 <= a->height_px; y += 4)
        for (int x = 0; x + 8 <= a->width_px; x += 4, count++)
            sum += square(a, b, x, y);
    return sum / (double)count;
}

static double light_of(uint8_t number)
{
    double n = number / 255.0;
    return n <= 0.04045 ? n / 12.92 : pow((n + 0.055) / 1.055, 2.4);
}

double ink_weight(const struct display_image *image, const uint8_t background[3])
{
    double sum = 0, light[256];
    for (int i = 0; i < 256; i++)
        light[i] = light_of((uint8_t)i);
    for (long i = 0; i < (long)image->width_px * image->height_px; i++)
        for (int c = 0; c < 3; c++)
            sum += light[background[c]] - light[image->pixels[3 * i + c]];
    return sum;
}
