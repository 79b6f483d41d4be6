module graspd

go 1.19
