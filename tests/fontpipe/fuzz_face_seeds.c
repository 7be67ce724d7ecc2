/* fuzz_face_seeds.c - small fonts to begin a fuzzer with: a few letters of each font that is installed.
 *
 *     fuzz_face_seeds FOLDER */
#include <fontconfig/fontconfig.h>
#include <hb-subset.h>

#include <stdbool.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static const uint32_t letters[] = {'A', 'V',  'f',   'i',   'g',   '&',   'l',
                                   ' ', 0xe9, 0x5d0, 0x627, 0x628, 0x644, 0x1f438};

static bool blob_write(const char *folder, int number, hb_blob_t *blob)
{
    char name[4096];
    unsigned count;
    const char *bytes = hb_blob_get_data(blob, &count);
    snprintf(name, sizeof name, "%s/font-%03d", folder, number);
    FILE *f = count ? fopen(name, "wb") : NULL;
    bool good = f && fwrite(bytes, 1, count, f) == count;
    return (f && fclose(f) == 0) && good;
}

/* The font with these letters alone, as it is where it cannot be made smaller. */
static bool seed_make(const char *file, const char *folder, int number)
{
    enum { WHOLE_MAX = 100000 };
    hb_blob_t *blob = hb_blob_create_from_file(file);
    hb_face_t *face = hb_face_create(blob, 0), *made = NULL;
    hb_subset_input_t *input = hb_subset_input_create_or_fail();
    for (size_t i = 0; input && i < sizeof letters / sizeof *letters; i++)
        hb_set_add(hb_subset_input_unicode_set(input), letters[i]);
    if (input && hb_face_get_glyph_count(face))
        made = hb_subset_or_fail(face, input);
    hb_blob_t *small = made ? hb_face_reference_blob(made) : hb_blob_reference(blob);
    bool good = hb_blob_get_length(small) < WHOLE_MAX && blob_write(folder, number, small);
    hb_blob_destroy(small);
    hb_face_destroy(made);
    hb_subset_input_destroy(input);
    hb_face_destroy(face);
    hb_blob_destroy(blob);
    return good;
}

int main(int argc, char **argv)
{
    if (argc != 2 || (mkdir(argv[1], 0777) != 0 && access(argv[1], W_OK) != 0)) {
        fprintf(stderr, "usage: fuzz_face_seeds FOLDER\n");
        return 2;
    }
    FcPattern *all = FcPatternCreate();
    FcObjectSet *file = FcObjectSetBuild(FC_FILE, NULL);
    FcFontSet *fonts = FcFontList(NULL, all, file);
    int made = 0;
    for (int i = 0; fonts && i < fonts->nfont; i++) {
        FcChar8 *name;
        if (FcPatternGetString(fonts->fonts[i], FC_FILE, 0, &name) == FcResultMatch)
            made += seed_make((const char *)name, argv[1], i);
    }
    printf("%d fonts\n", made);
    if (fonts)
        FcFontSetDestroy(fonts);
    FcObjectSetDestroy(file);
    FcPatternDestroy(all);
    return made ? 0 : 1;
}
