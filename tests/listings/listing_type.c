/* listing_type.c - appendix 7.5 of the thesis, included unchanged and compiled as gnu89.
 * LISTING_TYPE is the quoted path of the listing. The thesis reads the file into buff but
 * writes red; here both names mean the same gray bytes. */
#include <stdio.h>
#include <stdlib.h>

#include "page.h"

#define INITIALIZE_VECTORS                                                                     \
    FILE *fp;                                                                                  \
    unsigned char *buff;                                                                       \
    int test;                                                                                  \
    int offset_vector[2];                                                                      \
    unsigned int start_vector[2], end_vector[2], axis_vector[2], dimention_vector[2];          \
    offset_vector[0] = offset_vector[1] = 0;                                                   \
    start_vector[0] = y_off;                                                                   \
    start_vector[1] = x_off;                                                                   \
    end_vector[0] = y_off + height;                                                            \
    end_vector[1] = x_off + width;                                                             \
    axis_vector[0] = Y;                                                                        \
    axis_vector[1] = X;                                                                        \
    dimention_vector[0] = height;                                                              \
    dimention_vector[1] = width;
#define red buff

#include LISTING_TYPE
