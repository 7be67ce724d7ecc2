/* verb_info.c - `lutetia info`: lists devices, fonts and caches. */
#include "help.h"
#include "lutetia.h"
#include "options.h"

#include <paris_internal.h>
#include <visible_text.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void device_print(void *context, int index, const char *platform, const char *device,
                         const char *version, int compute_units, uint64_t memory_bytes)
{
    (void)context;
    visible_print("  %d: %s\n     %s, %s; %d compute units, %.1f GB\n", index, device, platform,
                  version, compute_units, (double)memory_bytes * 1e-9);
}

static void cache_print(void)
{
    char folder[MACHINE_CACHE_FOLDER_MAX];
    const char *why;
    if (!machine_cache_folder(folder, &why))
        visible_print("kernel cache: in memory only (%s)\n", why);
    else if (why)
        visible_print("kernel cache: %s, for this process alone (%s)\n", folder, why);
    else
        visible_print("kernel cache: %s\n", folder);
}

static void fields_print(int width, int height)
{
    const char *name;
    int bits;
    printf("a fiber of %dx%d paper takes %d bits:\n", width, height,
           paper_bits_per_fiber(width, height));
    for (int i = 0; paper_field_describe(width, height, i, &name, &bits); i++)
        printf("  %3d  %s\n", bits, name);
}

int verb_info(int argc, char **argv)
{
    int size[2] = {1024, 1024};
    bool variables = false;
    const struct option_row rows[] = {
        {"paper", 0, OPTION_SIZE, "WxH", "whose fibers to describe (1024x1024)", size,
         PAPER_SIDE_MIN, PAPER_SIDE_MAX, 0},
        {"variables", 0, OPTION_FLAG, NULL, "list the variables of the environment that count",
         &variables, 0, 0, 0},
        {0}};
    struct option_words words;
    if (!options_parse("info", rows, argc, argv, &words))
        return EXIT_USAGE;
    if (words.help)
        return help_print("info", rows, NULL);
    if (words.count)
        return fail_usage("info", "there is nothing to say about '%.60s'", words.words[0]);
    if (variables) {
        help_environment();
        return EXIT_SUCCESS;
    }

    puts("lutetia " LUTETIA_VERSION);
    puts("OpenCL devices:");
    if (machine_devices_list(device_print, NULL) <= 0)
        puts("  none");
    fields_print(size[0], size[1]);
    cache_print();
    if (!paris_reset(NULL))
        return fail("info", "%s", paris_error());
    visible_print("chosen: %s, %d physical processors\n", machine_device_name(paris_machine()),
                  machine_processors_count(paris_machine()));
    char tuned[800];
    machine_tuning_describe(paris_machine(), tuned, sizeof tuned);
    visible_print("%s\n", tuned);
    return EXIT_SUCCESS;
}
