/* In place of _exit in a program whose coverage is measured (-Db_coverage=true, linked with
 * --wrap=_exit): what ran is counted in the files of the build only when a process ends by exit. */
_Noreturn void __real__exit(int code);
_Noreturn void __wrap__exit(int code);
void __gcov_dump(void);

void __wrap__exit(int code) {
  __gcov_dump();
  __real__exit(code);
}
