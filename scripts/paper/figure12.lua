-- Figure 12: a sample of ten NURBS shapes, the first of the two pictures that are timed in figure
-- 13.
return require "shapes".film("Figure 12", 10, "figure 12")
