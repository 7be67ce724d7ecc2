/* bench.h - the functions that `lutetia bench NAME` calls, one for each benchmark.
 *
 *     return bench_diffusion_main(argc, argv);   // argv[0] is "diffusion", its options follow
 *
 * Each function measures our implementation and its peers in one run, prints a table, and
 * returns the exit status: 0; 1 if something failed, or results that must be equal differ; 2
 * if the options are wrong.
 */
#ifndef LUTETIA_BENCH_H
#define LUTETIA_BENCH_H

int bench_diffusion_main(int argc, char **argv);
int bench_calls_main(int argc, char **argv);
int bench_scan_main(int argc, char **argv);
int bench_rank_main(int argc, char **argv);
int bench_life_main(int argc, char **argv);
int bench_heat_main(int argc, char **argv);
int bench_paper_main(int argc, char **argv);
int bench_paris_main(int argc, char **argv);
int bench_fonts_main(int argc, char **argv);
int bench_text_main(int argc, char **argv);
int bench_midi_main(int argc, char **argv);
int bench_springs_main(int argc, char **argv);
int bench_interpreter_main(int argc, char **argv);
int bench_families_main(int argc, char **argv);
int bench_memory_main(int argc, char **argv);
int bench_start_main(int argc, char **argv);
int bench_display_main(int argc, char **argv);
int bench_studio_main(int argc, char **argv);
int bench_reader_main(int argc, char **argv);
int bench_model_main(int argc, char **argv);

#endif
