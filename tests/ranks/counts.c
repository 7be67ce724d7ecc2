/* counts.c - what is done where its arrays are, and not put together first: prints what each
 * instruction comes to, and (with an argument) what was put together meanwhile. */
#include <stdio.h>
#include <stdlib.h>

#include "cm/paris.h"
#include "machine_inside.h"
#include "paris_internal.h"

enum { ROWS = 120, COLUMNS = 70 };

static CM_field_id_t field, other, address;
static bool counts;

static void tell(const char *what, CM_field_id_t of)
{
    const uint64_t before = machine_blocks(paris_machine()).gathered;
    unsigned long long sum = 0;
    for (unsigned int i = 0; i < ROWS * COLUMNS; i += 997)
        sum = 31 * sum + CM_u_read_from_processor_1L(i, of, 32);
    sum = 31 * sum + CM_global_u_max_1L(of, 32);
    printf("%s: %llu", what, sum);
    if (counts)
        printf(", put together: %llu",
               (unsigned long long)(machine_blocks(paris_machine()).gathered - before));
    printf("\n");
}

static void begin(void)
{
    int sizes[2] = {ROWS, COLUMNS};
    CM_init();
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry(sizes, 2)));
    field = CM_allocate_stack_field(32);
    other = CM_allocate_stack_field(32);
    address = CM_allocate_stack_field(32);
    CM_my_send_address(address);
    CM_u_move_1L(field, address, 32);
    CM_u_multiply_constant_2_1L(field, 2654435761u, 32);
}

int main(int argc, char **argv)
{
    counts = argc > 1 && *argv[1];
    begin();
    tell("made", field);
    for (int i = 0; i < 40; i++) {
        CM_get_from_news_1L(other, field, 0, CM_upward, 32);
        CM_u_multiply_constant_2_1L(field, 5, 32);
        CM_logxor_2_1L(field, other, 32);
    }
    tell("shifted", field);
    CM_u_subfrom_constant_2_1L(address, ROWS * COLUMNS - 1, 32);
    CM_send_with_overwrite_1L(other, address, field, 32, CM_no_field);
    tell("sent", other);
    CM_u_truncate_constant_2_1L(address, 3, 32);
    CM_send_with_u_add_1L(other, address, field, 32, CM_no_field);
    tell("sent and added", other);
    CM_u_multiply_constant_2_1L(address, 2, 32);
    CM_get_1L(other, address, field, 32);
    tell("got", other);
    CM_scan_with_u_add_1L(other, field, 1, 32, CM_upward, CM_inclusive, CM_none, CM_no_field);
    tell("scanned", other);
    CM_spread_with_u_max_1L(other, field, 1, 32);
    tell("spread", other);
    CM_u_write_to_processor_1L(5000, other, 17, 32);
    tell("written", other);
    return 0;
}
