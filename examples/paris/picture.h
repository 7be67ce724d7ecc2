/* picture.h - writes an image in gray (channels 1: a PGM file) or colour (channels 3: PPM),
 * rows from the top.  Any image viewer shows them. */
#include <stdio.h>
#include <stdlib.h>

static void write_picture (name, pixels, width, height, channels)
    char *name;
    unsigned char *pixels;
    int width, height, channels;
{
    FILE *file;
    int good;

    file = fopen (name, "wb");
    good = file != NULL;
    if (good) {
        fprintf (file, "P%c\n%d %d\n255\n", channels == 3 ? '6' : '5', width, height);
        fwrite (pixels, channels, (size_t) width * height, file);
        good = !ferror (file);
        good = fclose (file) == 0 && good;
    }
    if (!good) {
        perror (name);
        exit (2);
    }
    printf ("picture: %s\n", name);
}
