# collada
