# render

render-memory = There is not enough memory for the image.
plot-no-font = No font is installed that could draw the labels of the plot; an .svg needs no font.
plot-too-large = The image of the plots would have more than 20 000 pixels per side; an .svg has no such limit.
plot-memory = There is not enough memory for an image of this size; an .svg needs little memory.
