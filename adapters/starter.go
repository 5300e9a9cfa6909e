// 1. Put your code into triangle() and line() below; set hasLines to false if you draw no lines.
// 2. Say in declares what your code promises, for example "origin=0,0 rule=none" (docs/protocol.md).
// 3. Judge it: go build starter.go && rasterproof judge -- ./starter
package main

import (
	"bufio"
	"fmt"
	"io"
	"math"
	"os"
	"runtime/debug"
	"sort"
	"strconv"
	"strings"
)

const (
	name     = "mine"
	declares = "batch=64"
	hasLines = true
)

// ---- YOUR PLACE: replace the bodies of these two functions ----

// Corners in pixels, y down; setPixel(x, y) for every pixel drawn. As it stands it draws every sample on an
// edge, so two neighbours both draw the edge they share.
func triangle(x0, y0, x1, y1, x2, y2 float64, width, height int, setPixel func(x, y int)) {
	side := func(ax, ay, bx, by, x, y float64) float64 { return (bx-ax)*(y-ay) - (by-ay)*(x-ax) }
	left := int(math.Max(0, math.Floor(math.Min(x0, math.Min(x1, x2)))))
	right := int(math.Min(float64(width), math.Ceil(math.Max(x0, math.Max(x1, x2)))))
	top := int(math.Max(0, math.Floor(math.Min(y0, math.Min(y1, y2)))))
	bottom := int(math.Min(float64(height), math.Ceil(math.Max(y0, math.Max(y1, y2)))))
	for y := top; y < bottom; y++ {
		for x := left; x < right; x++ {
			cx, cy := float64(x)+0.5, float64(y)+0.5
			e0, e1, e2 := side(x0, y0, x1, y1, cx, cy), side(x1, y1, x2, y2, cx, cy), side(x2, y2, x0, y0, cx, cy)
			if (e0 >= 0 && e1 >= 0 && e2 >= 0) || (e0 <= 0 && e1 <= 0 && e2 <= 0) {
				setPixel(x, y)
			}
		}
	}
}

// From one pixel to another, both drawn, in drawing order. As it stands, a plain DDA.
func line(x0, y0, x1, y1, width, height int, setPixel func(x, y int)) {
	dx, dy := float64(x1-x0), float64(y1-y0)
	steps := math.Max(math.Abs(dx), math.Abs(dy))
	// Of the longer direction, only the steps inside the window.
	start, step, size := float64(x0), dx, float64(width)
	if math.Abs(dy) > math.Abs(dx) {
		start, step, size = float64(y0), dy, float64(height)
	}
	first, last := math.Max(0, -start), math.Min(steps, size-1-start)
	if step < 0 {
		first, last = math.Max(0, start-size+1), math.Min(steps, start)
	}
	for i := first; i <= last; i++ {
		setPixel(int(math.Floor(float64(x0)+dx*i/math.Max(steps, 1)+0.5)),
			int(math.Floor(float64(y0)+dy*i/math.Max(steps, 1)+0.5)))
	}
}

// ---- the line protocol: nothing to change from here on ----

const (
	mostBytes = 65536
	mostSide  = 1024
	mostHits  = 1 << 22
)

type refused string

type hit struct{ x, y int }

func drawn(draw func(setPixel func(x, y int)), width, height int) (hits []hit) {
	draw(func(x, y int) {
		if x < 0 || y < 0 || x >= width || y >= height {
			return
		}
		if len(hits) == mostHits {
			panic(refused(fmt.Sprintf("more than %d pixels set", mostHits)))
		}
		hits = append(hits, hit{x, y})
	})
	return hits
}

// Row, first column, one past the last; a pixel hit twice is in two runs.
func runs(hits []hit) (found [][]int) {
	sort.Slice(hits, func(i, j int) bool {
		return hits[i].y < hits[j].y || hits[i].y == hits[j].y && hits[i].x < hits[j].x
	})
	for _, h := range hits {
		if n := len(found); n > 0 && found[n-1][0] == h.y && found[n-1][2] == h.x {
			found[n-1][2]++
		} else {
			found = append(found, []int{h.y, h.x, h.x + 1})
		}
	}
	return found
}

// A decimal number or a C99 hex float.
func number(word string) float64 {
	lower := strings.ToLower(word)
	if strings.Contains(lower, "0x") && !strings.Contains(lower, "p") {
		lower += "p0"
	}
	value, err := strconv.ParseFloat(lower, 64)
	if err != nil || !(value >= -(1<<31) && value < 1<<31) {
		panic(refused("a coordinate is not a number within 2^31 px"))
	}
	return value
}

func answer(words []string) (reply string) {
	verb, id := words[0], "-"
	if len(words) > 1 {
		id = words[1]
	}
	if verb == "HELLO" {
		known := name + " coverage"
		if hasLines {
			known += " line"
		}
		if len(words) == 2 && id == "1" {
			return "HELLO 1 " + known
		}
		if len(words) == 2 && id == "2" {
			return fmt.Sprintf("HELLO 2 %s window=%dx%d %s", known, mostSide, mostSide, declares)
		}
		return "E - say HELLO 1 or HELLO 2"
	}
	count, letter := 6, "C"
	if verb == "L" && hasLines {
		count, letter = 4, "P"
	} else if verb != "T" {
		return "E " + id + " unsupported"
	}
	defer func() {
		switch reason := recover().(type) {
		case nil:
		case refused:
			reply = "E " + id + " " + string(reason)
		default:
			fmt.Fprintf(os.Stderr, "%v\n%s", reason, debug.Stack())
			reply = "E " + id + " raised a panic"
		}
	}()
	if len(words) != count+4 {
		panic(refused(fmt.Sprintf("%s takes id width height and %d numbers", verb, count)))
	}
	width, wrongWidth := strconv.Atoi(words[2])
	height, wrongHeight := strconv.Atoi(words[3])
	if wrongWidth != nil || wrongHeight != nil || width < 1 || height < 1 || width > mostSide || height > mostSide {
		panic(refused(fmt.Sprintf("the window must be from 1x1 to %dx%d", mostSide, mostSide)))
	}
	v := make([]float64, count)
	for i := range v {
		v[i] = number(words[i+4])
	}
	groups := [][]int{}
	if verb == "T" {
		groups = runs(drawn(func(setPixel func(x, y int)) {
			triangle(v[0], v[1], v[2], v[3], v[4], v[5], width, height, setPixel)
		}, width, height))
	} else {
		pixel := func(i int) int { return int(math.Floor(v[i])) }
		for _, h := range drawn(func(setPixel func(x, y int)) {
			line(pixel(0), pixel(1), pixel(2), pixel(3), width, height, setPixel)
		}, width, height) {
			groups = append(groups, []int{h.x, h.y})
		}
	}
	text := strings.Builder{}
	fmt.Fprintf(&text, "%s %s %d", letter, id, len(groups))
	for _, group := range groups {
		for _, n := range group {
			text.WriteByte(' ')
			text.WriteString(strconv.Itoa(n))
		}
	}
	return text.String()
}

func main() {
	protocol := bufio.NewWriter(os.Stdout)
	os.Stdout = os.Stderr // what your code prints
	in := bufio.NewReaderSize(os.Stdin, mostBytes+1)
	for {
		request, err := in.ReadSlice('\n')
		tooLong := err == bufio.ErrBufferFull
		words := strings.FieldsFunc(string(request), func(r rune) bool { return strings.ContainsRune(" \t\r\n\v\f", r) })
		for err == bufio.ErrBufferFull {
			_, err = in.ReadSlice('\n')
		}
		if tooLong {
			fmt.Fprintf(protocol, "E - a request has at most %d bytes\n", mostBytes)
		} else if len(words) > 0 {
			fmt.Fprintln(protocol, answer(words))
		}
		if protocol.Flush() != nil || err == io.EOF {
			return
		}
	}
}
