--- require for celspan's private modules, used in their tests: own "celspan.reach".
require "celspan"
require "celspan.ease" -- the first chunk of celspan, which gives the others their globals

return debug.getregistry()["celspan.own"].require
