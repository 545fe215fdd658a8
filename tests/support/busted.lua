-- busted in the interpreter that runs this file. `busted --lua` would start the interpreter by a
-- shell, and pass all arguments to it without quotes.
require "busted.runner" { standalone = false }
