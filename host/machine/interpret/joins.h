/* joins.h - how a reduction joins two numbers. */
#ifndef LUTETIA_MACHINE_JOINS_H
#define LUTETIA_MACHINE_JOINS_H

#define JOIN_AND(a, x) ((a) & (x))
#define JOIN_OR(a, x) ((a) | (x))
#define JOIN_XOR(a, x) ((a) ^ (x))
#define JOIN_ADD(a, x) ((a) + (x))
#define JOIN_LEAST(a, x) ((x) < (a) ? (x) : (a))
#define JOIN_GREATEST(a, x) ((x) > (a) ? (x) : (a))

#endif
