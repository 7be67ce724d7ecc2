#include "device.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sample.h"

char device_message[512];

void device_error_catch(const char *message)
{
    snprintf(device_message, sizeof device_message, "%s", message);
}

void device_said(const char *call, const char *what)
{
    size_t length = strlen(call);
    if (strncmp(device_message, call, length) || strncmp(device_message + length, ": ", 2) ||
        !strstr(device_message + length, what) || strchr(device_message, '\n'))
        fail_msg("a wrong call of %s, about \"%s\", says \"%s\"", call, what, device_message);
    device_message[0] = '\0';
}

int device_setup(void **unused)
{
    (void)unused;
    device_start(-1);
    return 0;
}

void device_start(int eager)
{
    struct machine_config config = machine_config_default();
    config.processors_count = 16;
    config.eager = eager;
    if (!paris_reset(&config)) {
        fprintf(stderr, "skipped: %s\n", paris_error());
        exit(77);
    }
    int dimensions[2] = {ROWS, COLUMNS};
    CM_set_vp_set(CM_allocate_vp_set(CM_create_geometry((CM_vector_t){.ints = dimensions}, 2)));
}

/* ---- to and from fields ---- */

static void machine_stop(const char *what)
{
    fprintf(stderr, "%s: %s\n", what, machine_error(paris_machine()));
    exit(1);
}

void device_put(CM_field_id_t field, int width, const number *numbers)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char dense[COUNT * sizeof(number)];
    for (size_t i = 0; i < COUNT; i++) {
        number n = numbers[i] & oracle_mask(width);
        memcpy(dense + i * bytes, &n, bytes);
    }
    if (machine_field_upload(paris_machine(), field, MACHINE_UINT(width), dense) != MACHINE_OK)
        machine_stop("upload");
}

void device_get(CM_field_id_t field, int width, number *numbers)
{
    size_t bytes = machine_element_bytes(MACHINE_UINT(width));
    unsigned char dense[COUNT * sizeof(number)];
    if (machine_field_download(paris_machine(), field, MACHINE_UINT(width), dense) !=
        MACHINE_OK)
        machine_stop("download");
    for (size_t i = 0; i < COUNT; i++) {
        numbers[i] = 0;
        memcpy(&numbers[i], dense + i * bytes, bytes);
    }
}

/* ---- numbers ---- */

static uint64_t state = SAMPLE_SHIFTED_BEGIN;

void device_seed(uint64_t seed)
{
    state = seed * 2654435769u + SAMPLE_SHIFTED_BEGIN;
}

uint64_t device_random(void)
{
    return sample_shifted(&state);
}

void device_integers(number *numbers, int width)
{
    for (int i = 0; i < COUNT; i++) {
        number top = (number)1 << (width - 1);
        number any = (number)device_random() << 64 | device_random();
        switch (device_random() % 12) {
        case 0:
            any = 0;
            break;
        case 1:
            any = 1;
            break;
        case 2:
            any = ~(number)0;
            break;
        case 3:
            any = top;
            break;
        case 4:
            any = top - 1;
            break;
        case 5:
            any = (number)1 << device_random() % (unsigned)width;
            break;
        case 6:
            any >>= device_random() % 128; /* products that fit */
            break;
        default:
            break;
        }
        numbers[i] = any & oracle_mask(width);
    }
}

void device_floats(number *numbers, int width)
{
    static const double plain[] = {0,    -0.0, 1,   -1,  0.5, -0.5,  1.5,  2.5,   -2.5, 0.1,
                                   3e38, 1e-3, 255, 1e9, -7,  127.5, -128, 65536, 4e18, 0.3333};
    static const uint64_t bits32[] = {0x7f800000, 0xff800000, 0x7fc00000, 0xffc01234,
                                      0x7f800001, 0x00000001, 0x807fffff, 0x00800000,
                                      0x7f7fffff, 0xff7fffff, 0x4b000001, 0xcf000000};
    static const uint64_t bits64[] = {
        0x7ff0000000000000, 0xfff0000000000000, 0x7ff8000000000000, 0xfff8000000001234,
        0x7ff0000000000001, 0x0000000000000001, 0x800fffffffffffff, 0x0010000000000000,
        0x7fefffffffffffff, 0xffefffffffffffff, 0x4330000000000001, 0xc3e0000000000000};
    for (int i = 0; i < COUNT; i++) {
        uint64_t r = device_random();
        switch (device_random() % 4) {
        case 0:
            numbers[i] = width == 32 ? bits32[r % 12] : bits64[r % 12];
            break;
        case 1:
            numbers[i] = r & oracle_mask(width);
            break;
        case 2:
            numbers[i] = oracle_float_bits(width, plain[r % 20]);
            break;
        default:
            numbers[i] = oracle_float_bits(width, (double)(int64_t)r / 9007199254740992.0);
            break;
        }
    }
}

void device_mask(number *bits, int which)
{
    for (int i = 0; i < COUNT; i++)
        bits[i] = which % 3 == 0 ? 0 : which % 3 == 1 ? 1 : device_random() >> 20 & 1;
}
