/* A fuzz target over its corpus, without a fuzzer: every file named on the command line goes through
 * it as it is, and then with each of its allocations failing once.
 *
 * The target defines fail_at, the number of the allocation that fails (0: none), and allocations,
 * how many the last run made.
 */
#ifndef CELSPAN_TESTS_FUZZ_REPLAY_H
#define CELSPAN_TESTS_FUZZ_REPLAY_H

int main(int count, char **arguments) {
  static uint8_t bytes[1 << 20];
  size_t runs = 0;
  for (int i = 1; i < count; i++) {
    FILE *file = fopen(arguments[i], "rb");
    demand(file, arguments[i]);
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    fail_at = 0;
    LLVMFuzzerTestOneInput(bytes, size);
    size_t count_of_whole = allocations;
    for (fail_at = 1; fail_at <= count_of_whole; fail_at++)
      LLVMFuzzerTestOneInput(bytes, size);
    runs += 1 + count_of_whole;
  }
  printf("%zu checks passed\n", runs);
  return 0;
}

#endif
