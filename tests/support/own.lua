--- require for celspan's private modules, in tests of them: own "celspan.reach".
require "celspan"
require "celspan.ease" -- the first chunk of celspan's own, with which they get their globals

return debug.getregistry()["celspan.own"].require
