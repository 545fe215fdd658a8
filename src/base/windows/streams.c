/* In the programs of this tree, but not in the library: no byte of the standard streams, and of
 * files that C opens, is changed. */
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>

__attribute__((constructor)) static void keep_bytes(void) {
  _fmode = _O_BINARY;
  for (int number = 0; number <= 2; number++)
    _setmode(number, _O_BINARY);
}
