# Prints the points of an object of an R package that is installed: "p X Y" a point, and of a point pattern with a
# study window "r" before each of its rings and "w X Y" a vertex (shells counter-clockwise, holes clockwise).
#
#   Rscript --vanilla read_r.R FOLDER OBJECT
#
# FOLDER is the package's (/usr/lib/R/site-library/spData), OBJECT the name of a data set in it, or an expression of
# one, such as murchison$gold. Only base R is needed: objects of the packages spatstat, sf and sp are read as what
# they are made of.

args <- commandArgs(trailingOnly = TRUE)
folder <- file.path(args[1], "data")
data <- new.env()
if (file.exists(file.path(folder, "Rdata.rdb"))) {
  invisible(lazyLoad(file.path(folder, "Rdata"), envir = data))
} else {
  name <- sub("[^A-Za-z0-9._].*", "", args[2])
  load(file.path(folder, paste0(name, ".rda")), envir = data)
}
object <- eval(parse(text = args[2]), data)

# A matrix with a row a point.
coordinates_of <- function(object) {
  geometry <- attr(object, "sf_column")
  if (inherits(object, "ppp")) return(cbind(object$x, object$y))
  if (!is.null(geometry)) {
    places <- unclass(unclass(object)[[geometry]])
    return(t(vapply(places, function(place) as.numeric(unclass(place))[1:2], numeric(2))))
  }
  if (isS4(object)) return(attr(object, "coords")[, 1:2])
  as.matrix(object)[, 1:2]
}

# The rings of a study window; none of one that is a picture.
rings_of <- function(window) {
  if (is.null(window) || window$type == "mask") return(list())
  if (window$type == "polygonal") return(window$bdry)
  x <- window$xrange
  y <- window$yrange
  list(list(x = x[c(1, 2, 2, 1)], y = y[c(1, 1, 2, 2)]))
}

# 17 digits tell a double.
say <- function(mark, x, y) cat(sprintf("%s %.17g %.17g\n", mark, x, y), sep = "")

points <- coordinates_of(object)
say("p", points[, 1], points[, 2])
if (inherits(object, "ppp")) {
  for (ring in rings_of(object$window)) {
    cat("r\n")
    say("w", ring$x, ring$y)
  }
}
