# render

plot-no-font = There is no font on this machine to write the plot's numbers with; an .svg needs none.
plot-too-large = The plots make a picture of more than 20 000 pixels to a side; an .svg has no such limit.
plot-memory = There is not enough memory for a picture of that size; an .svg needs little.
