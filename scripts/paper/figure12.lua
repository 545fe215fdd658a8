-- Figure 12: a sample of ten NURBS shapes, the first of the two pictures that figure 13 times.
return require "shapes".film("Figure 12", 10, "figure 12")
