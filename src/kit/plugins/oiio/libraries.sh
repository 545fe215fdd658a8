#!/bin/sh
# libraries.sh MODULE: the libraries under a module, each after those that it needs where possible.
# None if one lies outside the system's folders: by its name alone, another one might be found.
ldd "$1" | awk '
  $2 == "=>" { names = $1 "\n" names }
  $2 == "=>" && $3 !~ /^\/(usr\/)?lib/ { outside = 1 }
  END { if (!outside) printf "%s", names }'
