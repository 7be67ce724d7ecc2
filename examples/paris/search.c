/* search.c - looks for a word in a text, a processor for each letter.
 *
 *     lutetia cc search.c -o search && ./search [word [file]]
 *
 * Shows: NEWS along a line of letters, and packing.  Each processor compares its letter with
 * the word's first, its right neighbour's letter with the second, and so on; a processor that
 * finds a difference becomes inactive.  The others number themselves (CM_enumerate) and send
 * their place to the processor of that number.  So the front end reads one number for each
 * match, not one for each letter. Compared with a search letter by letter. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cm/paris.h>

#define LETTER 8
#define PLACE 32

static char *verse[] = {
    "A town stood in a marsh before the town,\n",
    "and every stone of it was told the same:\n",
    "lift up, set down; lift up again, set down;\n",
    "and what they did together had a name.\n" };

static int counts[1], zero[1], axis[1];

/* Returns the file's text, or the verse many times; 0 bytes at the end prevent matches that
 * wrap round. */
char *get_text (name, margin)
    char *name;
    int margin;
{
    FILE *file;
    char *text;
    int length = 0, room = 1 << 16, got, i;

    text = malloc (room + margin);
    if (name) {
        file = fopen (name, "r");
        if (!file) {
            perror (name);
            exit (2);
        }
        while ((got = fread (text + length, 1, room - length, file)) > 0) {
            length += got;
            if (length == room)
                text = realloc (text, (room *= 2) + margin);
        }
        fclose (file);
    } else {
        for (i = 0; length + strlen (verse[i % 4]) <= room; i++) {
            strcpy (text + length, verse[i % 4]);
            length += strlen (verse[i % 4]);
        }
    }
    memset (text + length, 0, margin);
    counts[0] = length + margin;
    return text;
}

int main (argc, argv)
    int argc;
    char **argv;
{
    char *word, *text, *at;
    int i, found, expected = 0, right = 1;
    int *places, ends[1];
    CM_field_id_t letters, letter, number, address, place, result;

    word = argc > 1 ? argv[1] : "town";
    if (!*word) {
        fprintf (stderr, "usage: search [word [file]]\n");
        return 2;
    }
    text = get_text (argc > 2 ? argv[2] : (char *) 0, (int) strlen (word));
    CM_init ();
    CM_set_vp_set (CM_allocate_vp_set (CM_create_geometry (counts, 1)));
    letters = CM_allocate_heap_field (LETTER);
    result = CM_allocate_heap_field (PLACE);
    letter = CM_allocate_stack_field (LETTER);
    number = CM_allocate_stack_field (PLACE);
    place = CM_allocate_stack_field (PLACE);
    address = CM_allocate_stack_field (PLACE);
    CM_set_context ();
    CM_u_write_to_news_array_1L (text, zero, zero, counts, axis, letters, LETTER, 1, counts,
                                 CM_8_bit);
    CM_u_move_always_1L (letter, letters, LETTER);
    for (i = 0; word[i]; i++) {
        CM_u_eq_constant_1L (letter, word[i] & 255, LETTER);
        CM_logand_context_with_test ();
        CM_get_from_news_always_1L (letter, letter, 0, CM_upward, LETTER);
    }
    found = CM_global_count_context ();
    CM_enumerate_1L (number, 0, PLACE, CM_upward, CM_exclusive, CM_none, CM_no_field);
    CM_make_news_coordinate_1L (CM_current_geometry, address, 0, number, PLACE);
    CM_my_news_coordinate_1L (place, 0, PLACE);
    CM_send_1L (result, address, place, PLACE, CM_no_field);

    places = (int *) malloc ((found + 1) * sizeof (int));
    ends[0] = found;
    if (found)
        CM_u_read_from_news_array_1L (places, zero, zero, ends, axis, result, PLACE, 1, ends,
                                      CM_32_bit);
    printf ("\"%s\" is at %d places among %d letters", word, found, counts[0] - (int) strlen (word));
    for (i = 0; i < found && i < 8; i++)
        printf ("%s%d", i ? ", " : ": ", places[i]);
    printf (found > 8 ? ", ...\n" : "\n");

    for (at = text; at + strlen (word) <= text + counts[0]; at++)
        if (memcmp (at, word, strlen (word)) == 0) {
            right = right && expected < found && places[expected] == at - text;
            expected++;
        }
    right = right && expected == found;
    printf ("same as a plain search: %s\n", right ? "yes" : "no");
    return !right;
}
